"""The referee: it measures the simulator's true state and records findings. Each task defines which results are
right."""
