"""The checked program and its model of the cell. Neither depends on a language or an arm."""
