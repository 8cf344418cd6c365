"""`python -m usdvol_lint` is `usdvol-lint`."""

from usdvol_lint.cli import main

if __name__ == "__main__":
    main()
