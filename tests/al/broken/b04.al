; seat a pin, remember where the hole was, and bring a second one
        TRANS   P [18 44 3 90 90 0]
        TRANS   T [25 38 4 90 90 0]
        OPEN    1
        MOVE    P
        CLOSE   .1
        MOVE    T
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] 1.2
        SAVE    H               ;how far off the hole was
        SKIPN   23
        WAIT    "the pin met no bottom"
        OPEN    .5
        MOVE    P
        CLOSE   .1
        MOVE    T
        RESTORE H LEVEL
        OPEN    .5
