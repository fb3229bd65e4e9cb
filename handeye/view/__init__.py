"""The live cell in a browser: any number of viewers, one driver, and a run that none of them changes by watching."""
