; The hand goes down slowly until it presses with 25 oz. It goes farther than planned, so that it meets the face.
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE

        STAGE   "stand it on the plate"
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .3 .11
