"""What all cells with the Stanford arm have in common: the dimensions, the shapes of metal parts, and the arm with the
errors of its world.
"""
