"""The chess experiment of the paper: the arms find pieces, measure them, and put each on the line for pieces of its
height.
"""
