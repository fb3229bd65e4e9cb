"""The checked program, independent of language and arm, and the program's model of the cell."""
