"""The second waist: a plan, its format on disk, and what makes it valid."""
