"""What cells with the Stanford arm share: the arm as it was built, with its errors; dimensions; shapes of metal."""
