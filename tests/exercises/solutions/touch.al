        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    HOLE

        STAGE   "stand it on the plate"
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .3 .11
