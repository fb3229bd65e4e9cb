; lower the shaft into its seat, the seat may turn the hand
        TRANS   SHAFT [18 44 3 90 90 0]
        TRANS   ABOVE [25 38 6 90 90 0]
        TRANS   SEAT [25 38 4 90 90 0]
        OPEN    1.5
        MOVE    SHAFT
        CLOSE   .5
        MOVE    ABOVE
        STOP    [0 0 -40]
        SPIN    [1 1 0]
        MOVE    SEAT DIRECT
        SKIPN   23
        WAIT    "the shaft met no seat"
        OPEN    1.5
