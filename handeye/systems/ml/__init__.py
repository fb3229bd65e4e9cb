"""MOS and ML (IBM, 1975): guarded motions in a language of numbered statements, above a real-time level that watches
all sensors every ten milliseconds."""
