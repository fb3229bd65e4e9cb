"""Foundations for all other packages of handeye: units, poses, records, files, errors. This package imports none of
the other packages.
"""
