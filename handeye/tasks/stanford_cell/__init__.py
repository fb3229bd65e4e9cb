"""Parts common to all cells with the Stanford arm: the true arm with its errors; dimensions; shapes of metal parts."""
