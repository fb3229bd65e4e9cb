"""The honesty wall: every device of a cell as the working phase knows it, under one clock.

No body pose, contact list or true force crosses this wall. Lengths in metres, angles in radians, forces in newtons,
time in seconds. World frame W: table corner, z up.
"""
