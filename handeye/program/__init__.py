"""The checked program, which depends on no language and no arm, and its model of the cell."""
