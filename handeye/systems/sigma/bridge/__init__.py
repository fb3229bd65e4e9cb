"""The bridge from MAL to plans for another arm. It translates programs that have a single task of motions, force limits
and force tests.
"""
