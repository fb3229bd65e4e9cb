"""Arms as the real-time level sees them, and perfect motors."""
