"""The systems of the 1970s and 1980s. Each system has its own folder. `ENTRY` in this folder says what the system
offers and where its objects are.
"""
