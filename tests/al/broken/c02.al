; take hold of the gasket
        OPEN    1.9
        MOVE    G
        CLOSE   .7
        CHANGE  [0 0 1] 1
        MOVE    GON
        STOP    [0 O -12]
        CHANGE  [0 0 -1] 2.3
        SKIPN   23
        WAIT    "no pump under the gasket"
        OPEN    1.9
        PARK
