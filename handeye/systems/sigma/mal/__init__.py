"""MAL, Multipurpose Assembly Language: scanner, parser, checks, compiler, and the virtual machine that executes
tasks.
"""
