"""The language ML: its table of commands, parser, checks and listing."""
