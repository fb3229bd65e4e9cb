        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    HOLE

        STAGE   "insert it"
        SAVE    ABOVE           ;how high it begins
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the chamfer guide it
        CHANGE  [0 0 -1] .25 .11
        SKIPN   23
        JUMP    IN
        WAIT    "the pin stands on the face"
IN:     CHANGE  [0 0 -1] .56 2
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .35 .3
        HEIGHT  ABOVE -.98 -.78
        OPEN    1
