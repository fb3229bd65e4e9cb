; press the bearing home
        TRANS   BEARING [18 44 3 90 90 0]
        TRANS   BORE [25 38 4 90 90 0]
        OPEN    2
        MOVE    BEARING
        CLOSE   .5
        MOVE    BORE
        STOP [0 0 -50]  CHANGE [0 0 -1] .6      ;until it sits
        SKIPN   23
        WAIT    "the bearing is not in its bore"
        OPEN    2
        CHANGE  Z 1.5
