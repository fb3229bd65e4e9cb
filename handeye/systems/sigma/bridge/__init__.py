"""The bridge from MAL to plans for another arm. The bridge translates programs with a single task, which consists of
motions, force limits and force tests.
"""
