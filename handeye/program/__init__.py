"""The first waist: a checked program of no particular language, and what it believes of the cell."""
