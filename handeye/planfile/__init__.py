"""The plan, the interface between planning phase and working phase: its format on disk, and its checks."""
