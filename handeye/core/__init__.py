"""Foundations of every room: units, poses, records, files, errors; imports nothing else of handeye."""
