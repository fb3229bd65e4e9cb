"""Systems of the period, a folder each: language, machines, runs, words and commands."""
