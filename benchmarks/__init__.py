"""Benchmarks for developers: the cost of runs, of languages and of vision. They run from a checkout, and are not
shipped.
"""
