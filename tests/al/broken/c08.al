; take the gasket to its place and finish
        OPEN    1.9
        MOVE    G
        CLOSE   .7
        CHANGE  [0 0 1] 1
        MOVE    GON
        OPEN    1.9
        PARK
        STOP
