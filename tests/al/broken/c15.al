; straight to the gasket
        OPEN    1.9
        MOVE    G
        CLOSE   .7
        CHANGE  [0 0 1] 2
        MOVE    DIRECT GON
        STOP    [0 0 -12]
        CHANGE  [0 0 -1] 2.3
        SKIPN   23
        WAIT    "no pump"
        OPEN    1.9
        PARK
