        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    HOLE

        STAGE   "insert it"
        SEARCH  .07
L:      MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6 .11
        SKIPE   23
        AOJ     L
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] .6     ;it should meet some resistance
        SKIPN   23
        AOJ     L
