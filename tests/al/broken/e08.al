; from the stand to the bin
        TRANS   ROD [24 36 3.5 90 90 0]
        TRANS   BIN [28 33 5 90 90 0]
        PARK
        OPEN    1; MOVE    ROD
        CLOSE   .2
        CHANGE  Z 2
        MOVE    BIN
        OPEN    1
        PARK
