"""The first job: the program in figure 5 of the paper follows the outline of an object by touch."""
