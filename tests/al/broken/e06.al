; how high is the plate?
        TRANS   PLATE [26 35 5 90 90 0]
        OPEN    .4
        MOVE    PLATE
        STOP    [0 0 −30]
        CHANGE  [0 0 -1] 1.5
        SKIPN   23
        WAIT    "no plate"
        WHERE
        CHANGE  [0 0 1] 2
        PARK
