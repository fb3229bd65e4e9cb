"""Foundations used by all packages: units, poses, records, files, errors. Imports no other package of handeye."""
