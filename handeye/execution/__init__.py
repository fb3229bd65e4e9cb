"""The working phase: a plan meets a cell through its ports."""
