"""Kinematics and tolerances of the pump's assembly over many worlds at once, without simulating any."""
