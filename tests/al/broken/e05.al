        OPEN    1.9
        MOVE    G
        CLOSE   .7
        CHANGE  1 [0 0 1]
        MOVE    GON
        STOP    [0 0 -12]
        CHANGE  [0 0 -1] 2.3
        TRAVEL  1.6 2.2
        SKIPN   8
        WAIT    "the gasket stands on the pins"
        OPEN    1.9
        PARK
