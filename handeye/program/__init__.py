"""The first waist: a checked program of no particular language, and its beliefs about the cell."""
