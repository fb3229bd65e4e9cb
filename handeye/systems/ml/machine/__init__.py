"""The arms as the real-time level sees them, and a simulation of arms with perfect motors."""
