"""The two commands; the only place that prints errors and returns exit codes."""
