"""The bridge from MAL to the program of planned motions: single tasks of MOVE, LIMIT, FORCE tests and ACTUATE."""
