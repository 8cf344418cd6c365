"""What the text of a layer begins with."""

TEXT_SIGNATURES = (b"#usda", b"#sdf", b"#usd ")
