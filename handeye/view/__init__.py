"""The live cell in a browser: anybody looks on, one person drives, and the run is the same as if nobody did."""
