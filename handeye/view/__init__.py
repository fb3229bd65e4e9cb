"""The live cell in a browser: any number of viewers may watch without effect on the run, and one of them controls
it.
"""
