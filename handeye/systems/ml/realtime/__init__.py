"""The real-time level. Every ten milliseconds, it samples and checks all sensors, and sets the goals of all motors."""
