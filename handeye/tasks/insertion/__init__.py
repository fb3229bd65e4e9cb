"""One pin and one hole: the task of the insertion bench."""
