"""The rectilinear arm with physics. The real-time level drives this arm through the same ports as an arm with perfect
motors.
"""
