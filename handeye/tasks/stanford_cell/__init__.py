"""Parts common to all cells with the Stanford arm: the arm with its true errors, dimensions, and shapes of
metal parts."""
