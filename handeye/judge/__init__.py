"""The referee: its measurements on the truth, and its findings. Each task defines what is right, and why."""
