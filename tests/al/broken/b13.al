; take the washer over to the stud
        TRANS   WASHER [24 32 7 90 90 0]
        TRANS   STUD [25 38 4 90 -90 0]
        TRANS   PARK [20 28 8 90 90 0]
        OPEN    1.5
        MOVE    WASHER
        CLOSE   .4
        SKIPN   2
        WAIT    "no washer"
        MOVE    STUD
        OPEN    1.5
        PARK
