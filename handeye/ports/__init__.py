"""The interfaces of all devices of a cell, through which the working phase senses and acts, under one clock.

No body pose, contact list or true force is available through these interfaces. Lengths are in metres, angles in
radians, forces in newtons, times in seconds. World frame W: origin at the table corner, z up.
"""
