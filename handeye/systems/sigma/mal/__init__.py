"""MAL, the Multipurpose Assembly Language: its scanner, parser, checks and compiler, and the virtual machine
that executes tasks.
"""
