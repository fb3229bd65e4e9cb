"""Shows runs to people: reads traces and results, and drives nothing."""
