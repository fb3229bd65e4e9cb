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
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the chamfer guide it
        CHANGE  [0 0 -1] .25 .11
        SKIPE   23
        AOJ     L
        CHANGE  [0 0 -1] .56 2  ;most of the way, and fast
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .35 .3 ;it should meet some resistance
        SKIPN   23
        AOJ     L
