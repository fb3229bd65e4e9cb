; The search of a chamfered hole: its step is too large here, and nothing checks where the pin stands.
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE

        STAGE   "insert it"
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .25 .11
        OPEN    1
        CHANGE  [0 0 1] 1
