; Straight down, without a search and without a check.
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE

        STAGE   "insert it"
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] 1
        OPEN    1
