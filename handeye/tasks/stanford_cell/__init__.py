"""Parts of all cells with the Stanford arm: dimensions, shapes of metal parts, and the arm with the errors of its
world.
"""
