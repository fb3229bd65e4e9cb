"""The bridge from MAL to plans for another arm. The bridge translates programs that have a single task of motions,
force limits and force tests.
"""
