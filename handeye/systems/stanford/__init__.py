"""The hand-eye system of 1973: programs of the arm language, planned and carried out in a cell."""
