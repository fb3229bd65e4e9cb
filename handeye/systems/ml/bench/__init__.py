"""The rectilinear arm with physics, behind the ports of the real-time level."""
