"""The systems of the 1970s and 1980s, one folder each; the folder's `ENTRY` says what the system offers and where
its objects are.
"""
