"""The referee: measurements on the simulator's true state, and findings. Each task defines which results are right."""
