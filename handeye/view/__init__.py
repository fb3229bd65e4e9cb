"""Shows the live cell in a browser. Any number of viewers may watch without affecting the run; one viewer controls the
run.
"""
