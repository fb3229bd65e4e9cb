"""Systems of the period, a folder each: its `ENTRY` says what it offers, and where that is found."""
