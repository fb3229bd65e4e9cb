; The pin touches the face slowly. Back over its holder, it goes down as far as it was drawn out, until the holder holds it.
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        SAVE    HELD
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE

        STAGE   "touch the plate"
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .3 .11
        CHANGE  [0 0 1] 1

        STAGE   "put it back"
        MOVE    OVER
        RESTORE HELD            ; the error of the grasp
        STOP    [0 0 -40]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] 1.7 .4
        CLOSE   .1              ; it is still in the hand
        OPEN    1
        CHANGE  [0 0 1] 1.5
