"""The real-time level, which samples, checks and moves everything every ten milliseconds."""
