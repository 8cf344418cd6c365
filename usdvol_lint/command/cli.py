"""From command-line arguments to an exit code; no other module deals with either."""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import click

from usdvol_lint import __version__
from usdvol_lint.command.arguments import OUTPUTS, Arguments
from usdvol_lint.command.codes import CLEAN, FAILED, FINDINGS, ended_by, signal_of
from usdvol_lint.model import UsageError
from usdvol_lint.run.interruption import name_of
from usdvol_lint.run.limits import narrow_limits
from usdvol_lint.words import printable

if TYPE_CHECKING:
    from subprocess import Popen

    from usdvol_lint.packs.catalog import Catalog
    from usdvol_lint.run.interruption import Interruption


def _complete_code(context: click.Context, parameter: click.Parameter, typed: str) -> list[str]:
    from usdvol_lint.packs.catalog import load

    catalog = load()
    names = [*(rule.name for rule in catalog.rules.values()), *catalog.families]
    codes = [code for code in catalog.rules if code.startswith(typed.upper())]
    return codes + [name for name in names if typed and name.startswith(typed.lower())]


def _complete_from(constant: str) -> Any:
    """A shell completion with the values in a constant of `config`."""

    def complete(context: click.Context, parameter: click.Parameter, typed: str) -> list[str]:
        from usdvol_lint import config

        return [value for value in getattr(config, constant) if value.startswith(typed)]

    return complete


# fmt: off
@click.command(
    cls=Arguments,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog="Exit code: 0 clean, 1 findings at or above --fail-on, 2 the job could not be done.",
)
@click.argument("paths", nargs=-1, type=click.Path(readable=False), metavar="PATHS...")
@click.option("--select", multiple=True, metavar="CODES", shell_complete=_complete_code,
              help="Only these rules: codes, their beginnings, names, families, or ALL.")
@click.option("--ignore", multiple=True, metavar="CODES", shell_complete=_complete_code,
              help="Not these rules: codes, their beginnings, names or families.")
@click.option("--severity", multiple=True, metavar="CODE=LEVEL",
              help="Report a rule as error, warning or info.")
@click.option("--fail-on", metavar="LEVEL",
              shell_complete=_complete_from("FAIL_ON"),
              help="Exit with 1 from this level on: error (default), warning, info, never.")
@click.option("--fail-on-unchecked", is_flag=True,
              help="Exit with 1 if something could not be checked, whatever its level.")
@click.option("--output-format", multiple=True, metavar="FORMAT",
              shell_complete=_complete_from("OUTPUT_FORMATS"),
              help="auto (default), full, concise, json, jsonl, sarif, github, gitlab, junit, "
                   "markdown; may be repeated, each with its --output.")
@click.option("--output", multiple=True, type=click.Path(), metavar="FILE",
              help="Write the report to a file instead of standard output.")
@click.option("--category", metavar="NAME",
              help="What tells this upload of a SARIF report from others of the same commit.")
@click.option("--summary", metavar="[rule|cause|stage|asset]",
              shell_complete=_complete_from("SUMMARIES"),
              help="Print a table of the numbers alone (default: by rule).")
@click.option("--show", multiple=True, metavar="WHAT",
              shell_complete=_complete_from("SHOWABLE"),
              help="Show more: info, known, suppressed, unused (suppressions); may be repeated.")
@click.option("--color", type=click.Choice(["auto", "always", "never"]), default="auto",
              help="Colour the report; auto asks the terminal, NO_COLOR and FORCE_COLOR.")
@click.option("--quiet", "-q", is_flag=True, help="Print findings only; nothing when healthy.")
@click.option("--verbose", "-v", is_flag=True, help="Add infos, timings, counts and tracebacks.")
@click.option("--exclude", multiple=True, metavar="GLOB",
              help="Not these stages, as in a .gitignore here, named or not; may be repeated.")
@click.option("--files-from", metavar="FILE|-",
              help="Check the paths in a list too: a line each, or NUL between them.")
@click.option("--changed-since", metavar="REV",
              help="Only stages that use a file changed since git's merge base with REV; each is "
                   "opened to see that.")
@click.option("--show-files", is_flag=True, help="Print which stages would be checked and exit.")
@click.option("--frames", metavar="FIRST-LAST",
              help="The production's range of frames, in place of that of each stage.")
@click.option("--search-path", multiple=True, type=click.Path(), metavar="FOLDER",
              help="Where USD's resolver looks for paths without a folder; may be repeated.")
@click.option("--config", "config_file", type=click.Path(), metavar="FILE",
              help="Use this configuration file.")
@click.option("--isolated", is_flag=True, help="Use no configuration file.")
@click.option("--pack", multiple=True, type=click.Path(), metavar="FOLDER",
              help="Load the rules in a folder too; may be repeated.")
@click.option("--load", metavar="all|none",
              shell_complete=_complete_from("LOADS"),
              help="Load payloads (default: all).")
@click.option("--content", metavar="all|first|off",
              shell_complete=_complete_from("CONTENTS"),
              help="Look into all files of a field (default), the first one, or none.")
@click.option("--variants", metavar="selected|all",
              shell_complete=_complete_from("VARIANTS"),
              help="Check variants as selected (default), or all of them in turn.")
@click.option("--times", metavar="all|first|ends|N",
              shell_complete=_complete_from("TIMES"),
              help="Look at all time samples of particles (default), or at some.")
@click.option("--statistics", is_flag=True,
              help="Add what particle fields hold: count, bounds, opacity, scale.")
@click.option("--baseline", type=click.Path(), metavar="FILE",
              help="Count only what is not in this baseline, or JSON report, or is worse.")
@click.option("--no-baseline", is_flag=True, help="Use no baseline, whatever is configured.")
@click.option("--write-baseline", type=click.Path(), metavar="FILE",
              help="Write what is found as a baseline; with --baseline, bring that up to date.")
@click.option("--prune-baseline", is_flag=True,
              help="Take out of the baseline what is gone.")
@click.option("--fail-on-unpruned", is_flag=True,
              help="Exit with 1 if something in the baseline is gone.")
@click.option("--moved", multiple=True, metavar="OLD=NEW",
              help="A layer or folder in the baseline is called otherwise now; may be repeated.")
@click.option("--no-suppressions", is_flag=True,
              help="Count what is suppressed too, in stages and by the configuration.")
@click.option("--today", metavar="YYYY-MM-DD",
              help="The date by which suppressions expire (default: today's, in UTC).")
@click.option("--max-places", type=click.IntRange(min=1), metavar="N",
              help="How many places of a cause a report has in full (default: 20).")
@click.option("--root", type=click.Path(), metavar="FOLDER",
              help="The folder that layers go by in fingerprints (default: the repository's).")
@click.option("--jobs", "-j", type=click.IntRange(min=1), metavar="N",
              help="Worker processes (default: one for each processor that it may use).")
@click.option("--timeout", type=float, metavar="SECONDS",
              help="Time limit for one stage (default: 300).")
@click.option("--memory-limit", metavar="SIZE", help="Memory for one worker, such as 4G, or none.")
@click.option("--show-settings", is_flag=True,
              help="Print the settings in force, as a configuration file, and exit.")
@click.option("--list-rules", is_flag=True, help="Print every rule and exit.")
@click.option("--explain", metavar="CODE|NAME", shell_complete=_complete_code,
              help="Print the page of a rule and exit.")
@click.option("--test", type=click.Path(), metavar="FOLDER",
              help="Run the examples on the pages of a rule pack and exit.")
@click.version_option(__version__, message="%(prog)s %(version)s")
@click.pass_context
def command(context: click.Context, /, paths: tuple[str, ...], **given: Any) -> int:
    """Find what is broken in the volumes and particle fields of USD stages.

    PATHS are .usd, .usda, .usdc and .usdz files, folders that are searched for them, or quoted
    patterns such as "shots/**/*.usda".
    """
    given["outputs"] = context.meta[OUTPUTS]
    if given["output"]:
        from usdvol_lint.command.output import check_report

        check_report(given)
    if given["explain"] is not None:
        return _explain(given)
    if given["list_rules"]:
        return _list_rules(given)
    if given["test"] is not None:
        return _test(given)
    if given["show_settings"]:
        return _show_settings(given)
    if not paths and given["files_from"] is None:
        raise click.UsageError("nothing to check: name a stage or a folder")
    if given["show_files"]:
        return _show_files(paths, given)
    from usdvol_lint.command.linting import lint_stages

    return lint_stages(paths, given, *context.obj)


# fmt: on


def main(arguments: list[str] | None = None, *started: Popen[bytes] | Interruption | None) -> int:
    """Runs the command and returns its exit code; any failure is one line on standard error.

    `started` are the first worker process and what hears signals, if they are there already.
    """
    try:
        return int(command.main(arguments, "usdvol-lint", standalone_mode=False, obj=started))
    except click.ClickException as error:
        _report(error, arguments)
        context = error.ctx if isinstance(error, click.UsageError) else None
        with suppress(OSError):  # nobody reads, or the disk is full
            click.UsageError(printable(error.format_message()), context).show()
    except UsageError as error:
        _report(error, arguments)
        _tell(f"error: {error}")
    except (click.Abort, KeyboardInterrupt) as error:
        _tell(f"interrupted by {name_of(number := signal_of(error))}")
        return ended_by(number)
    except MemoryError:
        _tell(f"error: no memory is left{narrow_limits()}")
    except Exception as error:  # a bug of ours must exit with 2 too: 1 would mean findings
        words = " ".join(f"{type(error).__name__}: {error}".split())
        _tell(f"internal error: {words} (--verbose shows more)")
        if not {"-v", "--verbose"}.isdisjoint(sys.argv if arguments is None else arguments):
            import traceback

            traceback.print_exc()
    return FAILED


def _report(error: Exception, arguments: list[str] | None) -> None:
    """Writes the reports that are asked for, which were not written where the error came early."""
    from usdvol_lint.command.failed import report_misuse

    with suppress(OSError, UsageError):
        report_misuse(sys.argv[1:] if arguments is None else arguments, error)


def _tell(words: str) -> None:
    """Says on standard error what went wrong, if anybody can hear it."""
    with suppress(OSError):
        click.echo(f"usdvol-lint: {printable(words)}", err=True)


def help_text() -> str:
    """What `--help` prints; it is kept in `help.txt`, since importing click takes time."""
    context = click.Context(
        command, info_name="usdvol-lint", terminal_width=80, **command.context_settings
    )
    return command.get_help(context) + "\n"


def _explain(given: dict[str, Any]) -> int:
    from usdvol_lint.command import about, output

    options = output.options_of(given)
    page = about.explain(_catalog(given), given["explain"])
    output.print_text([about.render_page(page, options.color, options.width)])
    return CLEAN


def _list_rules(given: dict[str, Any]) -> int:
    from usdvol_lint.command import about, output

    catalog = _catalog(given)
    if "json" in given["output_format"]:
        output.print_text([about.list_rules_as_json(catalog)])
    else:
        output.print_text([about.list_rules(catalog, output.options_of(given).color)])
    return CLEAN


def _test(given: dict[str, Any]) -> int:
    from usdvol_lint.command import output
    from usdvol_lint.command.settings import check_filled
    from usdvol_lint.run import testing

    check_filled(given)
    failures, verdict = testing.check_pack(given["test"], given["pack"])
    output.print_text(f"{line}\n" for line in (*failures, verdict))
    return FINDINGS if failures else CLEAN


def _show_settings(given: dict[str, Any]) -> int:
    from usdvol_lint.command import about, output
    from usdvol_lint.command.settings import read_settings
    from usdvol_lint.packs.activation import activate
    from usdvol_lint.packs.catalog import load_for
    from usdvol_lint.packs.selection import still_ignored
    from usdvol_lint.run.layer_levels import verdicts
    from usdvol_lint.run.lint import settings_of
    from usdvol_lint.run.suppressing import reasons

    config, _ = read_settings(given)
    catalog = load_for(config)
    settings = settings_of(config, activate(config, catalog))
    reasons(config, catalog, root=None)  # which says where a table names no rule
    verdicts(config, catalog)
    config = config._replace(ignore=still_ignored(config, catalog))
    if "json" in given["output_format"]:
        output.print_text([about.show_settings_as_json(config, settings)])
    else:
        output.print_text([about.show_settings(config, catalog, settings)])
    return CLEAN


def _show_files(paths: tuple[str, ...], given: dict[str, Any]) -> int:
    from usdvol_lint.command import choosing, output

    lines, remark = choosing.shown(paths, given)
    output.print_text(lines)
    if remark and not given["quiet"]:
        click.echo(f"usdvol-lint: {remark}", err=True)
    return CLEAN


def _catalog(given: dict[str, Any]) -> Catalog:
    from usdvol_lint.command.settings import read_settings
    from usdvol_lint.packs.catalog import load_for

    config, _ = read_settings(given)
    return load_for(config)
