"""Defines the interfaces of all devices of a cell, and the cell's clock. The working phase senses and acts only
through these interfaces.

These interfaces reveal no pose of a body, no list of contacts and no true force. Lengths are in metres, angles
in radians, forces in newtons, times in seconds. The world frame W has its origin at the table corner, and z
points up.
"""
