; lay the gasket on the base, down until it is felt
        TRANS   STACK [24 32 7 90 90 0]
        TRANS   LID [25 38 4 90 90 0]
        OPEN    2
        MOVE    STACK
        CLOSE   .05
        MOVE    LID
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] -.8    ;down on it
        SKIPN   23
        WAIT    "the base was not felt"
        OPEN    2
        CHANGE  Z 2
