; The listing without its search.
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1
        SKIPN   23
        OPEN    1
        OPEN    1
