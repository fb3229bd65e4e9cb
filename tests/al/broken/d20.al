        PARK
        LENS    50
        AIM     PUMP
        LOOK    BEFORE
        OPEN    1.9
        MOVE    G
        CLOSE   .7
        CHANGE  [0 0 1] 1
        MOVE    GON
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] 2.3
        OPEN    1.9
        PARK
        LOOK    AFTER
        INSPECT PUMP BEFORE AFTER
        SKIPN   32
        WAIT    "THE GASKET IS NOT ON PROPERLY"
