"""The parts that cells with the Stanford arm share: the arm as built, with its errors; dimensions; shapes of metal."""
